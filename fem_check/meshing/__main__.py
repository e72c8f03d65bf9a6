"""`python -m fem_check.meshing`: make the repository's bricks and their manifest anew."""

from fem_check.meshing.files import committed_folder, write_committed

if __name__ == "__main__":
    write_committed(committed_folder())
