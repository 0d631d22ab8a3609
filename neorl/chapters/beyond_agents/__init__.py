"""What the page "The agent that the thesis stops short of" runs and draws."""
