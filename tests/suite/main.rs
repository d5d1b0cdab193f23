//! The one integration binary: a module per question.

mod fmi;
