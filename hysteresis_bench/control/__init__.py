"""From a fitted model to a voltage: inverse feed-forward, sliding mode, PI, and the loop that runs them on a rig."""
