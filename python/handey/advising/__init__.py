"""What is the smallest change with which a goal plans that fails as the cell is?

Each kind of change has a module that makes families of changes: one thing that is done by more or
less. `find_advice` tries them, the most plausible first, by planning with them.
"""
