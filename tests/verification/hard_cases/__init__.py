"""Named hard cases: what each is for, what must come out, and how near to fifty digits it comes."""
