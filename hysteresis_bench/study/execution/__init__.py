"""Tickets, such as trials, carried out by processes that can be killed, on this machine or on many."""
