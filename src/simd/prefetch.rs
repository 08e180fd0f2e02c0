//! Asking memory for data before it is needed: a hint, without effect on any result.
//!
//! The one place of the kernels with `unsafe`: the instruction takes a pointer. It reads nothing, it
//! never faults, whatever the address, and the addresses here are those of live slices.
#![allow(unsafe_code, reason = "the prefetch instruction takes a pointer; see the module")]

/// Bytes of a cache line.
const LINE: usize = 64;

/// Asks for the cache lines of a slice, at most `most` of them, to be brought near.
#[inline(always)]
pub(crate) fn prefetch<T>(slice: &[T], most: usize) {
    #[cfg(target_arch = "x86_64")]
    {
        use core::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        let bytes = size_of_val(slice);
        let start = slice.as_ptr().cast::<i8>();
        let mut at = 0;
        while at < bytes && at < most * LINE {
            // SAFETY: SSE is part of every x86-64, and a prefetch accesses no memory as far as the
            // program can tell: any address is allowed. `at` is below the slice's length in bytes.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(start.add(at)) };
            at += LINE;
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (slice, most, LINE);
}
