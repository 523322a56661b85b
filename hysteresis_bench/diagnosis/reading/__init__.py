"""Records read otherwise than they were measured: smoother, finer, without lone samples, with what came before."""
