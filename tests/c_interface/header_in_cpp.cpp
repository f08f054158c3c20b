#include "unsnarl/unsnarl.h"

static_assert(sizeof(unsnarl_surface) > sizeof(size_t), "the struct is complete");
