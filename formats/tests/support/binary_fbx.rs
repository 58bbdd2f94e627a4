//! The text of an FBX file as a binary one of version 7.4.

/// Names of arrays of whole numbers; the others are of doubles.
const WHOLE: [&str; 4] = ["PolygonVertexIndex", "UVIndex", "Materials", "Indexes"];

const MAGIC: &[u8] = b"Kaydara FBX Binary  \0\x1a\0";
const VERSION: u32 = 7400;

/// What closes a list of nodes.
const END: [u8; 13] = [0; 13];

/// The same file, binary.
pub fn binary_fbx(text: &str) -> Vec<u8> {
    let mut tokens = tokens(text).into_iter().peekable();
    let mut bytes = [MAGIC, &VERSION.to_le_bytes()].concat();
    while tokens.peek().is_some() {
        node(&mut tokens, &mut bytes);
    }
    bytes.extend(END);
    bytes
}

#[derive(Debug)]
enum Token {
    /// With a colon behind.
    Name(String),
    Text(String),
    Number(f64),
    /// How many numbers there are.
    Array,
    Open,
    Close,
}

type Tokens = std::iter::Peekable<std::vec::IntoIter<Token>>;

fn tokens(text: &str) -> Vec<Token> {
    let mut tokens = Vec::new();
    let lines = text.lines().filter(|line| !line.trim_start().starts_with(';'));
    for line in lines {
        let mut rest = line.trim_start_matches([' ', ',']);
        while let Some(first) = rest.chars().next() {
            let (token, length) = match first {
                '{' => (Token::Open, 1),
                '}' => (Token::Close, 1),
                '"' => {
                    let end = rest[1..].find('"').unwrap();
                    (Token::Text(rest[1..=end].to_owned()), end + 2)
                }
                _ => {
                    let end = rest.find([' ', ',', ':', '}']).unwrap_or(rest.len());
                    match rest.as_bytes().get(end) {
                        Some(b':') => (Token::Name(rest[..end].to_owned()), end + 1),
                        _ if first == '*' => (Token::Array, end),
                        _ => (Token::Number(rest[..end].parse().unwrap()), end),
                    }
                }
            };
            tokens.push(token);
            rest = rest[length..].trim_start_matches([' ', ',']);
        }
    }
    tokens
}

fn node(tokens: &mut Tokens, bytes: &mut Vec<u8>) {
    let Some(Token::Name(name)) = tokens.next() else { panic!("a node has no name") };
    let start = bytes.len();
    bytes.extend([0; 12]);
    bytes.push(name.len() as u8);
    bytes.extend(name.as_bytes());
    let properties = bytes.len();
    let count = write_properties(&name, tokens, bytes);
    let length = bytes.len() - properties;
    if matches!(tokens.peek(), Some(Token::Open)) {
        tokens.next();
        while !matches!(tokens.peek(), Some(Token::Close)) {
            node(tokens, bytes);
        }
        tokens.next();
        bytes.extend(END);
    }
    let head = [bytes.len() as u32, count, length as u32].map(u32::to_le_bytes).concat();
    bytes[start..start + 12].copy_from_slice(&head);
}

fn write_properties(name: &str, tokens: &mut Tokens, bytes: &mut Vec<u8>) -> u32 {
    let mut count = 0;
    while let Some(Token::Text(_) | Token::Number(_) | Token::Array) = tokens.peek() {
        count += 1;
        match tokens.next().unwrap() {
            Token::Text(text) => {
                // What a thing is called comes before what it is.
                let text = text
                    .split_once("::")
                    .map_or(text.clone(), |(kind, name)| format!("{name}\0\u{1}{kind}"));
                bytes.push(b'S');
                bytes.extend((text.len() as u32).to_le_bytes());
                bytes.extend(text.as_bytes());
            }
            // Numbers of objects have eight bytes, colours and places are doubles.
            Token::Number(number) if name == "P" => {
                bytes.push(b'D');
                bytes.extend(number.to_le_bytes());
            }
            Token::Number(number) => {
                bytes.push(b'L');
                bytes.extend((number as i64).to_le_bytes());
            }
            _ => array(name, tokens, bytes),
        }
    }
    count
}

/// `*COUNT { a: 1,2,3 }`
fn array(name: &str, tokens: &mut Tokens, bytes: &mut Vec<u8>) {
    tokens.next();
    tokens.next();
    let mut numbers = Vec::new();
    while let Some(Token::Number(number)) = tokens.next() {
        numbers.push(number);
    }
    let values: Vec<u8> = match WHOLE.contains(&name) {
        true => numbers.iter().flat_map(|number| (*number as i32).to_le_bytes()).collect(),
        false => numbers.iter().flat_map(|number| number.to_le_bytes()).collect(),
    };
    bytes.push(if WHOLE.contains(&name) { b'i' } else { b'd' });
    bytes.extend([numbers.len() as u32, 0, values.len() as u32].map(u32::to_le_bytes).concat());
    bytes.extend(values);
}
