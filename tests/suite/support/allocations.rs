//! How often did a piece of code ask for memory? The allocator of this test binary counts, thread by thread.
#![allow(unsafe_code, reason = "an allocator is unsafe by nature")]

use std::{
    alloc::{GlobalAlloc, Layout, System},
    cell::Cell,
};

thread_local! {
    static COUNT: Cell<usize> = const { Cell::new(0) };
    static FREED: Cell<usize> = const { Cell::new(0) };
}

struct Counting;

// SAFETY: everything is passed on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.set(COUNT.get() + 1);
        // SAFETY: the caller's promise.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        FREED.set(FREED.get() + 1);
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Number of allocations that `work` makes on this thread.
pub fn count(work: impl FnOnce()) -> usize {
    let before = COUNT.get();
    work();
    COUNT.get() - before
}

/// Number of allocations that `work` makes on this thread and does not give back; negative where it gives back others'.
pub fn left_over(work: impl FnOnce()) -> isize {
    let live = || COUNT.get() as isize - FREED.get() as isize;
    let before = live();
    work();
    live() - before
}

/// The count sees an allocation, or every use of it would prove nothing.
#[test]
fn an_allocation_is_counted() {
    assert_eq!(count(|| drop(std::hint::black_box(Box::new(1)))), 1);
    assert_eq!(count(|| ()), 0);
    let mut kept = Box::new(0);
    assert_eq!(left_over(|| kept = std::hint::black_box(Box::new(1))), 0, "a box for another");
    let mut list = Vec::new();
    assert_eq!(left_over(|| list.push(std::hint::black_box(*kept))), 1);
    assert_eq!(left_over(|| drop(list)), -1);
}
