"""The page on alternatives: other learners, controllers and a planner, compared with the thesis's agents."""
