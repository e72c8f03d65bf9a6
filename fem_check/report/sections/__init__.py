"""The sections of the validation report, one a file: each formats and draws what is on record, and computes nothing."""
