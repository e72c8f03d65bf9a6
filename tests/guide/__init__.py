"""The guide: every command, file and program in it runs."""
