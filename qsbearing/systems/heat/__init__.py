"""Heat in a bearing or a set, and the temperatures at which it runs; loaded only where a scene names [thermal].

All but `network`, which is what a scene gives. `balance` has its nodes and equations; `sources` the heat that friction
makes, by a model of the readings; `hot` a scene at given temperatures; `steady` the temperatures at which heat made and
heat carried off are equal, `speeds` those states followed from standstill in speed, `transient` the way there in time;
`solve` a bearing or a set at its steady temperatures.
"""
