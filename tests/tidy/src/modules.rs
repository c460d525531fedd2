//! Modules of a crate according to its files: the names that each one uses of the others, and its
//! re-exports. Tests are excluded.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use syn::visit::{self, Visit};
use syn::{Attribute, Item, ItemMod, ItemUse, UseTree, Visibility};

/// A path of names, from the crate's root.
pub(crate) type Names = Vec<String>;

/// A module that has a file.
#[derive(Default)]
pub(crate) struct Module {
    pub(crate) file: PathBuf,
    /// Re-exported names, with their original paths.
    pub(crate) handed_on: BTreeMap<String, Names>,
    /// Paths that its code names.
    pub(crate) used: BTreeSet<Names>,
}

/// The modules of a crate, by their paths.
pub(crate) type Modules = BTreeMap<Names, Module>;

fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|a| {
        a.path().is_ident("cfg")
            && a.parse_args::<syn::Path>()
                .is_ok_and(|p| p.is_ident("test"))
    })
}

/// Names used by a file, apart from its tests.
struct Reader<'a> {
    /// The module that is being read; inner modules are deeper than their file's.
    at: Names,
    module: &'a mut Module,
    /// Modules with their own files, and the `#[path]` of some.
    declared: Vec<(String, Option<String>)>,
}

impl Reader<'_> {
    /// Returns a path relative to the crate's root; `None` for another crate's.
    fn absolute(&self, names: &[String]) -> Option<Names> {
        let mut at = match names.first()?.as_str() {
            "crate" => Vec::new(),
            "self" | "super" => self.at.clone(),
            first if self.declared.iter().any(|(name, _)| name == first) => {
                let mut at = self.at.clone();
                at.push(first.to_owned());
                at
            }
            _ => return None,
        };
        for name in &names[1..] {
            at.push(name.clone());
        }
        if names[0] == "super" {
            let mut supers = names.iter().take_while(|n| *n == "super").count();
            at = self.at.clone();
            while supers > 0 {
                at.pop();
                supers -= 1;
            }
            at.extend(names.iter().skip_while(|n| *n == "super").cloned());
        }
        Some(at)
    }

    /// The leaves of a `use`: the path, and the name under which it is known here.
    fn leaves(tree: &UseTree, before: &[String], into: &mut Vec<(Names, String)>) {
        let with = |name: &syn::Ident| {
            let mut path = before.to_vec();
            path.push(name.to_string());
            path
        };
        match tree {
            UseTree::Path(path) => Self::leaves(&path.tree, &with(&path.ident), into),
            UseTree::Name(name) if name.ident == "self" => {
                let known = before.last().cloned().unwrap_or_default();
                into.push((before.to_vec(), known));
            }
            UseTree::Name(name) => into.push((with(&name.ident), name.ident.to_string())),
            UseTree::Rename(rename) => into.push((with(&rename.ident), rename.rename.to_string())),
            UseTree::Glob(_) => into.push((before.to_vec(), String::new())),
            UseTree::Group(group) => {
                for tree in &group.items {
                    Self::leaves(tree, before, into);
                }
            }
        }
    }
}

impl<'ast> Visit<'ast> for Reader<'_> {
    fn visit_item(&mut self, item: &'ast Item) {
        let attributes = match item {
            Item::Mod(i) => &i.attrs,
            Item::Fn(i) => &i.attrs,
            Item::Impl(i) => &i.attrs,
            Item::Use(i) => &i.attrs,
            _ => return visit::visit_item(self, item),
        };
        if !is_test(attributes) {
            visit::visit_item(self, item);
        }
    }

    fn visit_item_mod(&mut self, module: &'ast ItemMod) {
        let name = module.ident.to_string();
        if module.content.is_some() {
            self.at.push(name);
            visit::visit_item_mod(self, module);
            self.at.pop();
            return;
        }
        let path = module.attrs.iter().find_map(|a| match &a.meta {
            syn::Meta::NameValue(pair) if pair.path.is_ident("path") => match &pair.value {
                syn::Expr::Lit(syn::ExprLit {
                    lit: syn::Lit::Str(text),
                    ..
                }) => Some(text.value()),
                _ => None,
            },
            _ => None,
        });
        self.declared.push((name, path));
    }

    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        let mut leaves = Vec::new();
        Self::leaves(&item.tree, &[], &mut leaves);
        let hands_on = !matches!(item.vis, Visibility::Inherited);
        for (path, known) in leaves {
            let Some(path) = self.absolute(&path) else {
                continue;
            };
            if hands_on {
                self.module.handed_on.insert(known, path);
            } else {
                self.module.used.insert(path);
            }
        }
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let names: Names = path.segments.iter().map(|s| s.ident.to_string()).collect();
        if names.len() > 1
            && let Some(path) = self.absolute(&names)
        {
            self.module.used.insert(path);
        }
        visit::visit_path(self, path);
    }
}

/// Parses a module's text, and the children with files that it declares.
pub(crate) fn parse(
    file: &Path,
    text: &str,
    at: &Names,
) -> (Module, Vec<(String, Option<String>)>) {
    let syntax = syn::parse_file(text).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    let mut module = Module {
        file: file.to_owned(),
        ..Module::default()
    };
    let mut reader = Reader {
        at: at.clone(),
        module: &mut module,
        declared: Vec::new(),
    };
    // Declarations come first, so that paths that begin with a child are recognised.
    for item in &syntax.items {
        if let Item::Mod(m) = item
            && m.content.is_none()
            && !is_test(&m.attrs)
        {
            reader.visit_item_mod(m);
        }
    }
    let declared = reader.declared.clone();
    reader.visit_file(&syntax);
    (module, declared)
}

/// Reads a module's file and those of its children.
fn read(file: &Path, at: &Names, is_root: bool, into: &mut Modules) {
    let text = fs::read_to_string(file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    let (module, declared) = parse(file, &text, at);
    into.insert(at.clone(), module);
    let folder = file.parent().expect("a folder");
    let is_folder = is_root || file.file_name().is_some_and(|n| n == "mod.rs");
    for (name, path) in declared {
        let inner = if is_folder {
            folder.to_owned()
        } else {
            folder.join(file.file_stem().expect("a name"))
        };
        let flat = path.map_or_else(|| inner.join(format!("{name}.rs")), |p| folder.join(p));
        let file = if flat.exists() {
            flat
        } else {
            inner.join(&name).join("mod.rs")
        };
        let mut child = at.clone();
        child.push(name);
        read(&file, &child, false, into);
    }
}

/// Returns the module whose file defines a path.
pub(crate) fn home(modules: &Modules, path: &[String], hops: usize) -> Option<Names> {
    let length = (0..=path.len())
        .rev()
        .find(|n| modules.contains_key(&path[..*n]))?;
    let module = &modules[&path[..length]];
    if let Some(name) = path.get(length)
        && hops > 0
        && let Some(from) = module.handed_on.get(name)
    {
        let mut from = from.clone();
        from.extend_from_slice(&path[length + 1..]);
        return home(modules, &from, hops - 1);
    }
    Some(path[..length].to_vec())
}

/// The folder of the crates, and each crate's name with its modules.
pub(crate) fn crates() -> (PathBuf, Vec<(String, Modules)>) {
    let crates = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../crate");
    let mut all = Vec::new();
    for entry in fs::read_dir(&crates).expect("the crates") {
        let entry = entry.expect("an entry");
        let source = entry.path().join("src");
        let root = ["lib.rs", "main.rs"]
            .map(|n| source.join(n))
            .into_iter()
            .find(|p| p.exists())
            .expect("a root");
        let mut modules = Modules::new();
        read(&root, &Names::new(), true, &mut modules);
        all.push((entry.file_name().to_string_lossy().into_owned(), modules));
    }
    all.sort_by(|a, b| a.0.cmp(&b.0));
    (crates, all)
}
