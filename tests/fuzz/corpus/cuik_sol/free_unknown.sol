{ 1 x[0,1] } % isolated, free z
