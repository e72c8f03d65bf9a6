"""What accuracy costs with finite elements: measured, shown as a table and a picture, and used to choose a mesh."""
