"""Hard scenes of the stability suite: what they are, how they run, what must hold."""
