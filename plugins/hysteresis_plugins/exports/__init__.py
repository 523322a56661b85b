"""How what ships goes on by one sample, in the plain Python that `export` translates.

A module has functions of floats and of float arrays only: `law(s, p, t, u)`, or of an effect `before(s, p, t, u)` on
the input and `after(s, p, t, u, y)` on the output; `inverse(s, p, v)`, `undone(s, p, t, y)` where there is an inverse.
s : state, zeros before the first sample;  p : constants;  t : time;  u : input;  y : output so far
Their `part` says how long the state is and what the constants are; it runs where the export is made.
"""
