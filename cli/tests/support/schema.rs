//! The part of JSON Schema that `docs/report.schema.json` is written in. A keyword that is not known
//! here is an error: it would go unchecked.

use serde_json::Value;

/// What is otherwise than a schema says, by place.
pub fn errors(schema: &Value, value: &Value) -> Vec<String> {
    let mut found = Vec::new();
    Validator { root: schema, found: &mut found }.check(schema, value, "");
    found
}

struct Validator<'a> {
    root: &'a Value,
    found: &'a mut Vec<String>,
}

impl Validator<'_> {
    fn check(&mut self, schema: &Value, value: &Value, place: &str) {
        for (keyword, rule) in schema.as_object().expect("a schema is an object") {
            let number = || rule.as_f64().expect("a bound is a number");
            let length = value.as_array().map_or(0, Vec::len) as f64;
            let is_met = match keyword.as_str() {
                "$schema" | "$defs" | "title" | "description" => true,
                "type" => is_of(rule.as_str().unwrap_or_default(), value),
                "enum" => rule.as_array().is_some_and(|known| known.contains(value)),
                "minimum" => value.as_f64().is_none_or(|value| value >= number()),
                "maximum" => value.as_f64().is_none_or(|value| value <= number()),
                "minItems" => length >= number(),
                "maxItems" => length <= number(),
                "required" => {
                    let names = rule.as_array().into_iter().flatten().filter_map(Value::as_str);
                    names.into_iter().all(|name| value.get(name).is_some())
                }
                _ => self.check_parts(schema, keyword, value, place),
            };
            if !is_met {
                self.found.push(format!("{place}: {value} is not {keyword} {rule}"));
            }
        }
    }

    /// Goes into what a value is made of; whether the keyword is known.
    fn check_parts(&mut self, schema: &Value, keyword: &str, value: &Value, place: &str) -> bool {
        let rule = &schema[keyword];
        match keyword {
            "$ref" => {
                let pointer = rule.as_str().unwrap_or_default().trim_start_matches('#');
                let root = self.root;
                self.check(root.pointer(pointer).expect(pointer), value, place);
            }
            "items" => {
                for (number, item) in value.as_array().into_iter().flatten().enumerate() {
                    self.check(rule, item, &format!("{place}/{number}"));
                }
            }
            "properties" | "additionalProperties" | "propertyNames" => {
                for (name, field) in value.as_object().into_iter().flatten() {
                    let place = format!("{place}/{name}");
                    let known = schema.get("properties").and_then(|known| known.get(name));
                    match (keyword, known) {
                        ("properties", Some(known)) => self.check(known, field, &place),
                        ("propertyNames", _) => self.check(rule, &name.as_str().into(), &place),
                        ("additionalProperties", None) if rule.is_object() => {
                            self.check(rule, field, &place);
                        }
                        ("additionalProperties", None) => {
                            self.found.push(format!("{place} is not known"));
                        }
                        _ => {}
                    }
                }
            }
            _ => return false,
        }
        true
    }
}

fn is_of(kind: &str, value: &Value) -> bool {
    match kind {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "integer" => value.is_u64(),
        "number" => value.is_number(),
        _ => false,
    }
}
