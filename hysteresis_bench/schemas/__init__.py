"""What study, model and diagnosis files hold, as JSON schemas: for editors, and for programs that read them."""
