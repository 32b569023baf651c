"""What is simulated: scenes, trajectories, and the checks each scene must pass."""
