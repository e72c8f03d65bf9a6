"""A local page to work on a scene or set: inputs on the left, results on the right, on one screen.

`answers` is what the page may ask, as plain data in and out; `inputs` makes its fields of the keys of a scene file,
`channels` the choices of what is loaded, placed or free, `effect_forms` what belongs to an effect, `required` the
answers to requirements; `drawn` draws its pictures, `exports` writes reports and tables; `server` hands them out. The
server keeps nothing between two questions but the last solutions, by their whole input: the scene, and what can be
undone, are the page's own, so that sessions cannot meet.
"""
