"""How the kernel is compiled, where the compiled code is kept, and how cases are shared out among threads."""
