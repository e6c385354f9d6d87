// Shared with the hard cases, which the program runs too.
#pragma once

#include "methods/direct_to_indirect/hard_cases/gather_setup.h"
