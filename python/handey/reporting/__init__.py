"""What was tried and why it failed: typed reasons, the funnel of each goal, the report."""
