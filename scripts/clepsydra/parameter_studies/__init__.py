"""Parts of scripts/parameterStudy: plan (which tasks there are), task (runs one), status (what is done), executors."""
