"""Documents: what a report or a page says, apart from how HTML and PDF show it.

`model` holds the pieces, `markdown` makes them of a page of the guide, `html` and `pdf` write them.
"""
