SOLUTIONS (to input file a.cuik):

STATISTICS
