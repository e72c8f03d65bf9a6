"""What is solved: units and materials, contact, scene, effects, kernel, solution. It knows no file and no page."""
