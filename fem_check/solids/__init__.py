"""True curved bodies: ball and ring segments of 10-node tetrahedra, in contact along their exact surfaces.

How one contact, or several, are solved; SI units throughout, the plane of symmetry through the ball's centre is z = 0:

    contact = ContactFrame.of(Sphere(...), Groove(...), angle, ...)     # where the surfaces touch, exact heights, normals
    mesh = body_mesh.ball(radius, [patch, ...], elements)               # gmsh; or body_mesh.ring(...)
    body = TetrahedralBody(mesh, material)
    loads = contact.ball_loads(body) or contact.ring_loads(body)        # one column per pressure basis function
    flexibility = condense_supported(body, loads, fixed) or condense_free(body, loads)
    pressure = normal_contact.solve(flexibility, gaps)                  # p >= 0, gap >= 0, for a given position
    contact_results.read(contact, pressure)                             # Q, angle, a, b, largest pressure

`true_contact` puts half a ball and one ring segment together this way, under a load along the contact angle;
`bearing_sector` puts ball and both rings together this way and finds their positions by Newton's method.
"""
