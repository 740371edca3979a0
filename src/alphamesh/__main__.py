"""``python -m alphamesh`` is the command line."""

from alphamesh.cli import main

if __name__ == "__main__":
    main()
