"""What there is to say about solved cases: how they ended, and what to beware of in their numbers.

A remark is data (`remark`); its sentence is made of its code (`kinds`) when somebody reads it. `of_solution` is
asked, whatever was solved; `bearing` speaks for the cases of a bearing, `qsbearing.systems.sets.remarks` for those of a
set. Each other file makes the remarks of one subject, for a stretch of cases: `balls`, `expansion`, `preload`,
`missing_effects`. Readings remark on their own numbers.
"""
