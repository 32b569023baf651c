"""What is true: closed forms as pure functions, numbers in, arrays out."""
