"""Columns of a .parquet file, whose size is known before its pages are read."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from qsbearing.files.file_errors import refused
from qsbearing.files.limits import LARGEST_TABLE, LONGEST_CELL, check_size, is_empty

KINDS = ("integer", "floating", "decimal", "boolean", "temporal", "dictionary", "null")
"""Of columns that are read, apart from texts."""


def columns_of_parquet(data: bytes, path: Path) -> dict[str, list[Any]]:
    """The cells of each column, a named index of pandas among them.

    Raises:
        SceneFileError: it is too large, or a column holds no single values. Of damaged files also other exceptions.
    """
    import pyarrow
    from pyarrow import parquet
    from pyarrow import types as kinds

    source = pyarrow.BufferReader(data)
    file = parquet.ParquetFile(source)
    held = file.metadata
    check_size(path, held.num_rows, held.num_columns)
    sizes = [held.row_group(number).total_byte_size for number in range(held.num_row_groups)]
    if sum(sizes) > LARGEST_TABLE:
        raise refused(path, f"holds {sum(sizes) / 1e6:,.0f} MB; at most {LARGEST_TABLE / 1e6:g} MB are read")
    texts = []
    for field in file.schema_arrow:
        is_text = kinds.is_string(field.type) or kinds.is_large_string(field.type)
        if not is_text and not any(getattr(kinds, f"is_{kind}")(field.type) for kind in KINDS):
            raise refused(path, f"column {field.name[:60]} holds {field.type}, not one number or text a cell")
        if is_text:
            texts.append(field.name)
    # Texts as numbers of a list: one that is repeated a million times is held once.
    table = parquet.ParquetFile(source, read_dictionary=texts).read(use_threads=False)
    columns: dict[str, list[Any]] = _counted(table)
    for name, column in zip(table.column_names, table.columns, strict=True):
        if name.startswith("__index_level_"):  # without a name
            continue
        if name in columns or not name.strip():
            raise refused(path, f"two columns {name[:60]}" if name.strip() else "a column has no heading")
        cells = [cell for chunk in column.chunks for cell in _cells(chunk, path)]
        columns[name] = [None if is_empty(cell) else cell for cell in cells]
    return columns


def _counted(table: Any) -> dict[str, list[Any]]:
    """Of pandas an index with a name that counts evenly, which is kept as three numbers."""
    known = (table.schema.pandas_metadata or {}).get("index_columns", [])
    kept = {each["name"]: range(each["start"], each["stop"], each["step"]) for each in known if isinstance(each, dict)}
    return {name: list(values) for name, values in kept.items() if name and len(values) == table.num_rows}


def _cells(chunk: Any, path: Path) -> list[Any]:
    if not hasattr(chunk, "dictionary"):
        return list(chunk.to_pylist())
    words = chunk.dictionary.to_pylist()
    if any(isinstance(word, str) and len(word) > LONGEST_CELL for word in words):
        raise refused(path, f"a cell has more than {LONGEST_CELL:,} characters")
    return [None if number is None else words[number] for number in chunk.indices.to_pylist()]
