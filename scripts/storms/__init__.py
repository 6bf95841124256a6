"""What `scripts/storm` runs: one storm a file, and what they share: session.py, seen_map.py, silence.py."""
