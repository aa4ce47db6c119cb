"""Files read strictly and written whole: YAML, JSON, fields with their faults, poses."""
