"""Random scenes over the whole envelope, each solved, classified and checked: `python -m tests.verification.campaign
--help`."""
