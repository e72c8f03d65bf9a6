"""A scene's cases made, solved and read off."""
