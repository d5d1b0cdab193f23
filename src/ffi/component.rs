//! What a host holds: an instance and the way to its callbacks; and how an instantiation makes one.

use std::{
    ffi::{CStr, CString, c_void},
    fs,
    path::{Path, PathBuf},
};

use super::{
    fmi3_types::{Callbacks, fmi3False, fmi3InstanceEnvironment, fmi3LogMessageCallback, fmi3True},
    live,
    types::{fmi2CallbackFunctions, fmi2CallbackLogger, fmi2ComponentEnvironment},
};
use crate::fmi::{
    LogCategory, Model, Status,
    error::Error,
    instance::{Instance, Progress},
    lifecycle::Standard,
    location::{self, LIBRARY},
    log,
};
use crate::packed::Packed;

/// The host as an instance sees it.
#[derive(Clone, Debug)]
pub enum Host {
    /// A host of FMI 2.0.
    Fmi2 {
        /// Name of the instance.
        name: CString,
        /// Takes log lines.
        logger: fmi2CallbackLogger,
        /// Handed back with every callback.
        environment: fmi2ComponentEnvironment,
    },
    /// A host of FMI 3.0.
    Fmi3(Callbacks),
}

impl Host {
    /// Keeps what is needed of the host's callbacks, under the instance's name.
    pub fn new(name: &CStr, functions: &fmi2CallbackFunctions) -> Self {
        Self::Fmi2 { name: name.to_owned(), logger: functions.logger, environment: functions.componentEnvironment }
    }

    /// The version of the standard that it speaks.
    pub fn standard(&self) -> Standard {
        match self {
            Self::Fmi2 { .. } => Standard::Fmi2,
            Self::Fmi3(_) => Standard::Fmi3,
        }
    }

    /// Hands a line to the host's logger, if it has one.
    pub fn log(&self, status: Status, category: LogCategory, message: &str) {
        let category = category.c_name().as_ptr();
        match self {
            Self::Fmi2 { name, logger: Some(logger), environment } => {
                let message = log::prepare(message);
                // SAFETY: the host promises at `fmi2Instantiate` that its logger can be called as long as the instance
                // lives; the texts live until the call returns, and the format asks for no further arguments.
                unsafe { logger(*environment, name.as_ptr(), status.into(), category, message.as_ptr()) }
            }
            Self::Fmi3(Callbacks { log_message: Some(logger), environment, .. }) => {
                let message = log::prepare_fmi3(message);
                // SAFETY: as above, by `fmi3InstantiateCoSimulation`.
                unsafe { logger(*environment, status.into(), category, message.as_ptr()) }
            }
            Self::Fmi2 { .. } | Self::Fmi3(_) => (),
        }
    }
}

impl Callbacks {
    /// Those of a host that hears of no internal steps.
    pub(super) fn of_log(environment: fmi3InstanceEnvironment, log_message: fmi3LogMessageCallback) -> Self {
        Self { environment, log_message, intermediate_update: None, early_return_allowed: false }
    }

    /// Whether the host wants to hear of internal steps.
    pub(super) fn has_update(&self) -> bool {
        self.intermediate_update.is_some()
    }

    /// Tells the host of a finished internal step; returns whether it wants the communication step to end there. The
    /// host may call functions of the instance meanwhile: the caller holds no borrow of it.
    pub(super) fn update(&self, progress: Progress) -> bool {
        let Some(update) = self.intermediate_update else { return false };
        let can_return = self.early_return_allowed && !progress.arrived;
        let (mut requested, mut time) = (fmi3False, progress.time);
        // SAFETY: the host promises at `fmi3InstantiateCoSimulation` that its callback can be called during
        // `fmi3DoStep`; both answers can be written to.
        unsafe {
            update(
                self.environment,
                progress.time,
                (!progress.arrived).into(),
                fmi3True,
                fmi3True,
                can_return.into(),
                &raw mut requested,
                &raw mut time,
            );
        }
        can_return && requested != fmi3False
    }
}

/// An instance and its host.
pub struct Component<M: Model> {
    pub(super) instance: Instance<M>,
    pub(super) host: Host,
}

impl<M: Model> Component<M> {
    /// A new component of a loaded model, for co-simulation; its first log lines go to the host.
    pub fn new(model: M, host: Host, logging_on: bool) -> Self {
        Self { instance: Instance::of(host.standard(), model, logging_on), host }.reported()
    }

    /// A new component for Model Exchange.
    ///
    /// # Errors
    /// The model is for co-simulation only.
    pub fn for_model_exchange(model: M, host: Host, logging_on: bool) -> Result<Self, Error> {
        let instance = Instance::for_model_exchange(host.standard(), model, logging_on)?;
        Ok(Self { instance, host }.reported())
    }

    fn reported(mut self) -> Self {
        self.report();
        self
    }

    /// Hands the instance's log lines to the host. FMI 3.0 forbids all but errors where a category is switched off
    /// (section 2.3.1).
    pub(super) fn report(&mut self) {
        for entry in self.instance.take_entries() {
            let is_error = entry.status >= Status::Error;
            if is_error || self.host.standard() == Standard::Fmi2 || self.instance.wants(entry.category) {
                self.host.log(entry.status, entry.category, &entry.message);
            }
        }
    }

    /// The handle for the host, to be given back by [`Self::from_handle`].
    pub fn into_handle(self) -> *mut c_void {
        live::INSTANCES.hand_out(self)
    }

    /// The component behind a handle; none: it is not live.
    ///
    /// # Safety
    /// A live `handle` has this model type, and is not in use elsewhere.
    pub(super) unsafe fn behind<'a>(handle: *mut c_void) -> Option<&'a mut Self> {
        // SAFETY: the caller's promise.
        unsafe { live::INSTANCES.behind(handle) }
    }

    /// Takes a component back from the host; none: the handle is not live.
    ///
    /// # Safety
    /// A live `handle` has this model type, and is not in use elsewhere.
    pub unsafe fn from_handle(handle: *mut c_void) -> Option<Box<Self>> {
        // SAFETY: the caller's promise.
        unsafe { live::INSTANCES.take_back(handle) }
    }
}

/// Loads the model of an unpacked FMU.
///
/// # Errors
/// No resources, no readable model file, a file that is no model, or another GUID than the description's.
pub fn load(guid: &str, resources: &str) -> Result<Packed, Error> {
    let directory = match location::directory(resources)? {
        Some(directory) => directory,
        None => own_resources()?,
    };
    let path = directory.join(Packed::file(|name| directory.join(name).is_file()));
    let text = fs::read_to_string(&path).map_err(|reason| {
        Error::Instantiate(format!(
            "cannot read the model file {}: {reason}; the resource location must be the unpacked `resources` directory \
             of the FMU",
            path.display()
        ))
    })?;
    let model = Packed::load(&directory, &path, &text)?;
    let own = &model.about().guid;
    if own != guid {
        return Err(Error::Instantiate(format!(
            "the GUID `{guid}` is not that of the model file {}, `{own}`: modelDescription.xml and resources belong to \
             different models, or the file was changed; pack it again",
            path.display()
        )));
    }
    Ok(model)
}

/// `../../resources` seen from the file this library was loaded from.
fn own_resources() -> Result<PathBuf, Error> {
    let library = own_file().ok_or_else(|| {
        Error::Instantiate(format!("no resource location was given, and the system does not tell where {LIBRARY} is"))
    })?;
    let directory = library.parent().unwrap_or(Path::new(".")).join("../../resources");
    Ok(directory.canonicalize().unwrap_or(directory))
}

/// The file this code was loaded from.
#[cfg(unix)]
fn own_file() -> Option<PathBuf> {
    use std::{ffi::OsStr, mem::MaybeUninit, os::unix::ffi::OsStrExt};

    let address: *const c_void = (own_file as fn() -> Option<PathBuf>) as *const c_void;
    let mut info = MaybeUninit::<libc::Dl_info>::zeroed();
    // SAFETY: the address is of this function, and `info` has room for the answer.
    let found = unsafe { libc::dladdr(address, info.as_mut_ptr()) } != 0;
    // SAFETY: all zeros is a valid `Dl_info`, and the call has filled it or not.
    let info = unsafe { info.assume_init() };
    if !found || info.dli_fname.is_null() {
        return None;
    }
    // SAFETY: the dynamic linker keeps the name as long as this library is loaded.
    let name = unsafe { CStr::from_ptr(info.dli_fname) };
    Some(PathBuf::from(OsStr::from_bytes(name.to_bytes())))
}

/// The file this code was loaded from.
#[cfg(windows)]
fn own_file() -> Option<PathBuf> {
    use std::{ffi::OsString, os::windows::ffi::OsStringExt, ptr::null_mut};

    /// The module that an address is in, without counting it as a use.
    const FROM_ADDRESS_UNCOUNTED: u32 = 4 | 2;
    #[link(name = "kernel32")]
    unsafe extern "system" {
        fn GetModuleHandleExW(flags: u32, address: *const c_void, module: *mut *mut c_void) -> i32;
        fn GetModuleFileNameW(module: *mut c_void, name: *mut u16, size: u32) -> u32;
    }

    let address: *const c_void = (own_file as fn() -> Option<PathBuf>) as *const c_void;
    let (mut module, mut name) = (null_mut(), [0; 32_768]); // the longest path of Windows
    // SAFETY: the address is of this function, and `module` has room for the answer.
    let found = unsafe { GetModuleHandleExW(FROM_ADDRESS_UNCOUNTED, address, &raw mut module) } != 0;
    // SAFETY: the module is this one, which is loaded, and `name` is as long as is said.
    let length = if found { unsafe { GetModuleFileNameW(module, name.as_mut_ptr(), name.len() as u32) } } else { 0 };
    (length > 0).then(|| PathBuf::from(OsString::from_wide(&name[..length as usize])))
}

/// Other systems do not tell; hosts there must pass the resource location.
#[cfg(not(any(unix, windows)))]
fn own_file() -> Option<PathBuf> {
    None
}
