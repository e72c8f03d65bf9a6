"""What comes in: bytes of regular files, bounded before they are parsed, as plain tables and columns.

Whatever is wrong with a file ends in one exception, `SceneFileError`; what its keys mean is not known here.
"""
