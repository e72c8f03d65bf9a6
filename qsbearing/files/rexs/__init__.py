"""Models of REXS, the exchange format of gearbox and shaft programs: read as scene files, results put back."""
