"""A solved case as data and as tables: bearing and set side by side, and where a record comes from."""
