"""A cell file from its entries to a cell of the compiled core, and what is refused in it."""
