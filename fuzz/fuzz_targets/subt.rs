#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| uchain_fuzz::subt(bytes));
