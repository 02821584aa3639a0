
Written by corank 0.1.0
 1 : { 1 x[0,1] } % regular
