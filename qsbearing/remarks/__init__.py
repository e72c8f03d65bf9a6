"""What there is to say about solved cases: how they ended, and what to beware of in their numbers.

A remark is data (`remark`); its sentence is made when somebody reads it, of the kind (`kinds`) that stands where its
numbers are known. `of_solution` is asked, whatever was solved; `bearing` speaks for the cases of a bearing,
`qsbearing.systems.sets.remarks` for those of a set. Each other file makes the remarks of one subject, for some cases
(`case_range`): `ring`, `balls`, `expansion`, `preload`, `missing_effects`, `hypotheses`. Readings remark on their own
numbers.
"""
