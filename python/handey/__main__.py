"""`python -m handey`: the command line."""

from handey.cli import run

if __name__ == "__main__":
    run()
