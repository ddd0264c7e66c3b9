// One of the lists that LIGGGHTS' build writes and its package leaves out: the models of hertzPairStyle.cpp.
#include "rolling_model_cdt.h"
