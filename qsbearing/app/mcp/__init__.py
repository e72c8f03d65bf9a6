"""What a language model may ask, over the Model Context Protocol (MCP) on standard input and output.

`folder` is where files may be; `tools` and `describe` are what may be asked, as plain data in and out, of the same
functions that the commands call; `server` hands it to the official SDK.
"""
