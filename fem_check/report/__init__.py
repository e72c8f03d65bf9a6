"""The report, built from the records alone: it formats and draws, it computes nothing."""
