"""Where the law is in doubt: is another one the cause of what is left, and which names hold whatever the law?"""
