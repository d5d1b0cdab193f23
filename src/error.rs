//! What failed in the mechanics, where, with which numbers.
