//! Sections, the ANCF14 element, joints and loads: no FMI, no files, no solver.
