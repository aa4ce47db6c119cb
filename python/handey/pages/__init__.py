"""What all pages of handey are made of."""
