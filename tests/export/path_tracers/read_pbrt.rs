// SPDX-License-Identifier: BSD-3-Clause
//! read_pbrt FILE...: prints the statements of each scene as the crate pbrt4 reads them, one a line.

fn main() {
    for path in std::env::args().skip(1) {
        let text = std::fs::read_to_string(&path).expect("a file of text");
        let mut parser = pbrt4::Parser::new(&text);
        loop {
            match parser.parse_next() {
                Ok(element) => println!("{element:?}"),
                Err(pbrt4::Error::EndOfFile) => break,
                Err(error) => {
                    println!("error: {error}");
                    std::process::exit(1);
                }
            }
        }
    }
}
