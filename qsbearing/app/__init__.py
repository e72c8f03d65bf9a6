"""A local page to explore a scene: sliders on the left, what they do on the right.

`answers` is what the page may ask, as plain data in and out; `inputs` makes its fields of the keys of a scene file;
`drawn` draws its pictures; `server` hands them out. The server keeps nothing between two questions: the scene, and
what can be undone, are the page's own, so that sessions cannot meet.
"""
