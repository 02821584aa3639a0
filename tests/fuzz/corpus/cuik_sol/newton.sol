
Random seed: 7
% PARAMETERS:
   SIGMA = 0.1
SOLUTIONS (to input file a.cuik):

Newton [s:1.5 v:2 l:8 t:0.04]: { 1  x[0.5,0.5] }
   1 (err:0.1 tm:0.2): <S> { 1  x[0,1] }
END OF THE SOLUTION FILE
