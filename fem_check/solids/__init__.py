"""True curved bodies: ball and ring segments of 10-node tetrahedra, in contact along their exact surfaces.

How one contact, or several, are solved; SI units throughout, the plane of symmetry through the ball's centre is z = 0:

    frame = ContactFrame(Sphere(...), Torus(...), normal, Patch(...), elements, ball_share)   # both exact surfaces
    mesh = bodies.ball(radius, [frame.patch, ...], elements)        # gmsh, about the origin; or bodies.ring(...)
    body = TetrahedralBody(mesh.shifted(centre), material)
    loads = frame.loads(body, on_ball=True)                            # one column per pressure basis function
    solid = condense_free(body, loads)                                 # or condense_supported(body, loads, fixed)
    contact = normal_contact.solve(flexibility, frame.weighted_gap(ball, groove))   # both bodies' flexibility, added
    contact_results.read(frame, contact.pressures)                     # Q, angle, a, b, largest pressure

`true_contact` puts half a ball and one ring segment together this way, under a load along the contact angle;
`bearing_sector` puts ball and both rings together this way and finds their positions by Newton's method.
"""
