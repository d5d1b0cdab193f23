//! Machines from seeded random numbers, as the text of model files.
