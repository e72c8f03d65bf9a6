"""Which effects and choices a scene calls for: predicted, chosen to a tolerance, and explained.

Nothing here knows an effect by name: all goes through `qsbearing.model.effects.EFFECTS`.
"""
