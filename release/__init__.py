"""What makes and tries a release; nothing of it is installed."""
