{ 2  x[0,1] y[-1.5,2e-3] } % regular, free x
{ 2  x[1,2] y[-0,0] } % undecided
