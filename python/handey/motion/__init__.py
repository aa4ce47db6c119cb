"""One grasp carried through: gross motions, lifts and the ways out."""
