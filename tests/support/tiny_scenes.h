// The hand-made scenes belong to the hard cases, which the program runs too (`relight hard-cases`).
#pragma once

#include "common/hard_cases/tiny_scenes.h"
