# Installs the command chamfer for Windows: takes the newest release and puts the program into
# %LOCALAPPDATA%\chamfer, which it adds to the user's Path. It asks for no rights and changes nothing else.
$ErrorActionPreference = "Stop"
$address = if ($env:CHAMFER_ADDRESS) { $env:CHAMFER_ADDRESS } else { "@ADDRESS@" }
$bin = if ($env:CHAMFER_BIN) { $env:CHAMFER_BIN } else { Join-Path $env:LOCALAPPDATA "chamfer" }
$archive = Join-Path ([IO.Path]::GetTempPath()) "chamfer-windows.tar.gz"
Invoke-WebRequest -UseBasicParsing "$address/releases/latest/download/chamfer-windows.tar.gz" -OutFile $archive
New-Item -ItemType Directory -Force $bin | Out-Null
# tar is a part of Windows since version 10.
tar -C $bin -xzf $archive
Remove-Item $archive
$path = [Environment]::GetEnvironmentVariable("Path", "User")
if (($path -split ";") -notcontains $bin) {
    [Environment]::SetEnvironmentVariable("Path", "$path;$bin", "User")
}
Write-Output "installed $bin\chamfer.exe; in a new window, try: chamfer demo"
