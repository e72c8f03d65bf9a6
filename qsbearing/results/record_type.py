"""What a record of results is: an object of JSON whose numbers the descriptions of results name."""

from __future__ import annotations

from typing import Any

Record = dict[str, Any]
"""The object that `run --json` prints, or a part of it. Its keys follow from `Result.in_record` and `Group.table`, by
which every number is described once; a type would be a second list of them."""
