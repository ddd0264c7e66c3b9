"""The parts of scripts/campaign: plan (which tasks there are), task (runs one), status (what is done), executors."""
