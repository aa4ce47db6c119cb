"""The gross motions of a plan in slices of configuration space, as pictures."""
