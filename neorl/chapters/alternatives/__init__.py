"""What the page on alternatives runs and draws: other learners, controllers and a planner beside the thesis's own."""
