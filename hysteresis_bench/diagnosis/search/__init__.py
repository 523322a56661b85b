"""The search: which hypothesis do the data ask for, and does it hold on excitations left out?"""
