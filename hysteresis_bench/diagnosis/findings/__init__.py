"""What a diagnosis tells."""
