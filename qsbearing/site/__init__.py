"""The site: the guide and a reference made from the code, for reading in a browser. Nothing imports it; it is run.

Its engine, MkDocs with the theme Material and mkdocstrings, is the extra "docs". It can be exchanged: what is written
for it is a folder of plain Markdown.
"""
