"""The steps of planning a task: in which order, which grasps, how much of each, and why not."""
