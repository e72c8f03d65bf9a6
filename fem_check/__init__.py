"""Three-dimensional finite-element checks of the contacts that `qsbearing` takes from Hertz."""
