"""Ways in which Python comes to a wait that no call of the callback names."""
